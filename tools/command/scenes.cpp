#include <algorithm>
#include <iostream>
#include <memory>
#include <string>

#include <swept/samples/built_in/builtin_scenes.h>
#include <swept/samples/scene_reader.h>

#include "../writers/number_text.h"
#include "commands.h"
#include "scene_source.h"

namespace swept {
namespace {

void listScenes() {
    std::size_t widest = 0;
    for (const BuiltinScene& scene : builtinScenes()) { widest = std::max(widest, std::string(scene.name).size()); }
    for (const BuiltinScene& scene : builtinScenes()) {
        std::string name = scene.name;
        name.resize(widest, ' ');
        std::cout << name << "  " << scene.purpose << " (" << roundedText(scene.duration) << " s)\n";
    }
}

int printScene(const std::string& name) {
    if (const BuiltinScene* const scene = findBuiltinScene(name)) {
        std::cout << textOfScene(scene->make());
        return kExitDone;
    }
    const std::string nearest = nearestSceneName(name);
    return refuse(name + ": no built-in scene of that name" +
                  (nearest.empty() ? " (\"swept scenes\" lists them)" : "; did you mean \"" + nearest + "\"?"));
}

}  // namespace

void addScenesCommand(Command app) {
    const Command command = app.command("scenes", "List the built-in scenes, or print one as a file");
    const auto name = std::make_shared<std::string>();
    const Option json =
        command.option("--json", *name, "Print this scene as JSON, to start a scene file from").type("NAME");
    command.runs([name, json] {
        if (json.isGiven()) { return printScene(*name); }
        listScenes();
        return kExitDone;
    });
}

}  // namespace swept
