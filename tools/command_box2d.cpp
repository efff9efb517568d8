#include "commands.h"
#include "reference/box2d_child.h"

namespace swept {

void addBox2dChildCommand(CLI::App& app, int& exitCode) {
    CLI::App* const command = app.add_subcommand(kBox2dChildCommand, "One scene in Box2D, driven through pipes");
    command->group("");  // not in the help
    command->callback([&exitCode] { exitCode = runBox2dChild(); });
}

}  // namespace swept
