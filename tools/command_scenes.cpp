#include <algorithm>
#include <iostream>
#include <memory>
#include <string>

#include <swept/samples/builtin_scenes.h>
#include <swept/samples/scene_reader.h>

#include "commands.h"
#include "number_text.h"
#include "scene_source.h"

namespace swept {
namespace {

void listScenes() {
    std::size_t widest = 0;
    for (const BuiltinScene& scene : builtinScenes()) {
        widest = std::max(widest, std::string(scene.name).size());
    }
    for (const BuiltinScene& scene : builtinScenes()) {
        std::string name = scene.name;
        name.resize(widest, ' ');
        std::cout << name << "  " << scene.purpose << " (" << roundedText(scene.duration) << " s)\n";
    }
}

int printScene(const std::string& name) {
    if (const BuiltinScene* const scene = findBuiltinScene(name)) {
        std::string json = writeScene(scene->make());
        if (json.empty() || json.back() != '\n') {
            json += '\n';
        }
        std::cout << json;
        return kExitDone;
    }
    const std::string nearest = nearestSceneName(name);
    return refuse(name + ": no built-in scene of that name" +
                  (nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?"));
}

}  // namespace

void addScenesCommand(CLI::App& app, int& exitCode) {
    CLI::App* const command = app.add_subcommand("scenes", "List the built-in scenes, or print one as a file");
    const auto name = std::make_shared<std::string>();
    command->add_option("--json", *name, "Print this scene as JSON, to start a scene file from")->type_name("NAME");
    command->callback([name, command, &exitCode] {
        if (command->count("--json") > 0) {
            exitCode = printScene(*name);
        } else {
            listScenes();
        }
    });
}

}  // namespace swept
