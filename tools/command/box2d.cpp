#include "../reference/box2d_child.h"
#include "commands.h"

namespace swept {

void addBox2dChildCommand(Command app) {
    const Command command = app.command(kBox2dChildCommand, "");
    command.runs([] { return runBox2dChild(); });
}

}  // namespace swept
