#include <algorithm>
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "../inspect/inspect_scene.h"
#include "../writers/output_files.h"
#include "commands.h"
#include "scene_source.h"

namespace swept {
namespace {

/// So many findings of one kind are told in full; the rest is counted.
constexpr int kTold = 3;

struct InspectArguments {
    SceneArguments scene;
    std::string json;
    bool strict = false;
};

const char* nameOf(Severity severity) { return severity == Severity::warning ? "warning" : "note"; }

void printFindings(const std::vector<Finding>& findings) {
    if (findings.empty()) { std::cout << "Nothing in this scene lies outside the measured envelope.\n"; }
    std::map<std::string, int> told;
    std::map<std::string, int> left;
    for (const Finding& finding : findings) {
        if (++told[finding.kind] > kTold) {
            ++left[finding.kind];
            continue;
        }
        std::cout << nameOf(finding.severity) << " [" << finding.kind << "] " << finding.where << '\n'
                  << "    " << finding.text << ".\n";
        if (!finding.remedy.empty()) { std::cout << "    Mend: " << finding.remedy << ".\n"; }
    }
    for (const auto& [kind, count] : left) {
        std::cout << "… and " << count << " more of [" << kind << "] (--json lists all)\n";
    }
}

void printNeeds(const std::vector<Need>& needs) {
    std::cout << "\nWhat the scene needs:\n";
    std::size_t widest = 0;
    for (const Need& need : needs) { widest = std::max(widest, need.feature.size()); }
    for (const Need& need : needs) {
        std::cout << "  " << need.feature << std::string(widest - need.feature.size(), ' ')
                  << (need.needed ? "  yes  " : "  no   ") << need.reason << '\n';
    }
}

std::string jsonOf(const std::string& source, const Inspection& inspection) {
    nlohmann::ordered_json json;
    json["scene"] = source;
    json["findings"] = nlohmann::ordered_json::array();
    for (const Finding& finding : inspection.findings) {
        json["findings"].push_back({{"severity", nameOf(finding.severity)},
                                    {"kind", finding.kind},
                                    {"where", finding.where},
                                    {"text", finding.text},
                                    {"remedy", finding.remedy}});
    }
    json["needs"] = nlohmann::ordered_json::array();
    for (const Need& need : inspection.needs) {
        json["needs"].push_back({{"feature", need.feature}, {"needed", need.needed}, {"reason", need.reason}});
    }
    return json.dump(2) + '\n';
}

int inspect(const InspectArguments& arguments) {
    std::string error;
    const auto loaded = loadScene(arguments.scene, error);
    if (!loaded) { return refuse(error); }
    OutputFiles outputs;
    outputs.protect(loaded->file);
    outputs.addFile("--json", arguments.json);
    if (!outputs.open(error)) { return refuse(error); }
    const Inspection inspection = inspectScene(loaded->scene);
    printFindings(inspection.findings);
    printNeeds(inspection.needs);
    if (std::ostream* const json = outputs.stream(arguments.json)) { *json << jsonOf(loaded->source, inspection); }
    if (!outputs.close(error)) { return refuse(error); }
    const bool isBad = !inspection.findings.empty() && inspection.findings.front().severity == Severity::warning;
    return arguments.strict && isBad ? kExitNotFinite : kExitDone;
}

}  // namespace

void addInspectCommand(Command app) {
    const Command command =
        app.command("inspect", "The scene doctor: what may go wrong, and what the scene needs, before it runs");
    const auto arguments = std::make_shared<InspectArguments>();
    arguments->scene.isRun = false;
    addSceneArguments(command, arguments->scene);
    command.option("--json", arguments->json, "All findings and needs as JSON").type("FILE");
    command.flag("--strict", arguments->strict, "Exit code 1 when there is a warning");
    command.runs([arguments] { return inspect(*arguments); });
}

}  // namespace swept
