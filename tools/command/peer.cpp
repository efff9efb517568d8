#include "../reference/peer_child.h"
#include "commands.h"

namespace swept {

void addPeerChildCommand(Command app) {
    const Command command = app.command(kPeerChildCommand, "");
    command.runs([] { return runPeerChild(); });
}

}  // namespace swept
