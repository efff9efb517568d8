#include <algorithm>
#include <iostream>
#include <map>
#include <memory>
#include <string>

#include "../inspect/inspect_scene.h"
#include "../writers/output_files.h"
#include "../writers/report_json.h"
#include "commands.h"
#include "json_output.h"
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

void printFindings(std::ostream& out, const std::vector<Finding>& findings) {
    if (findings.empty()) { out << "Nothing in this scene lies outside the measured envelope.\n"; }
    std::map<std::string, int> told;
    std::map<std::string, int> left;
    for (const Finding& finding : findings) {
        if (++told[finding.kind] > kTold) {
            ++left[finding.kind];
            continue;
        }
        out << nameOf(finding.severity) << " [" << finding.kind << "] " << finding.where << '\n'
            << "    " << finding.text << ".\n";
        if (!finding.remedy.empty()) { out << "    Mend: " << finding.remedy << ".\n"; }
    }
    for (const auto& [kind, count] : left) {
        out << "… and " << count << " more of [" << kind << "] (--json lists all)\n";
    }
}

void printNeeds(std::ostream& out, const std::vector<Need>& needs) {
    out << "\nWhat the scene needs:\n";
    std::size_t widest = 0;
    for (const Need& need : needs) { widest = std::max(widest, need.feature.size()); }
    for (const Need& need : needs) {
        out << "  " << need.feature << std::string(widest - need.feature.size(), ' ')
            << (need.needed ? "  yes  " : "  no   ") << need.reason << '\n';
    }
}

std::string inspectionJson(const LoadedScene& loaded, const Inspection& inspection) {
    RunFacts facts = factsOf(loaded);
    facts.precision.clear();  // the doctor looks at both
    facts.steps.reset();
    ReportJson json = headOf(loaded.scene, facts);
    json["findings"] = ReportJson::array();
    for (const Finding& finding : inspection.findings) {
        json["findings"].push_back({{"severity", nameOf(finding.severity)},
                                    {"kind", finding.kind},
                                    {"where", finding.where},
                                    {"text", finding.text},
                                    {"remedy", finding.remedy}});
    }
    json["needs"] = ReportJson::array();
    for (const Need& need : inspection.needs) {
        json["needs"].push_back({{"feature", need.feature}, {"needed", need.needed}, {"reason", need.reason}});
    }
    return jsonText(json);
}

int inspect(const InspectArguments& arguments) {
    std::string error;
    const auto loaded = loadScene(arguments.scene, error);
    if (!loaded) { return refuse(error); }
    OutputFiles outputs;
    outputs.protect(loaded->file);
    outputs.addStream("--json", arguments.json);
    if (!outputs.open(error)) { return refuse(error); }
    const Inspection inspection = inspectScene(loaded->scene);
    std::ostream& out = toldBeside(arguments.json);
    printFindings(out, inspection.findings);
    printNeeds(out, inspection.needs);
    if (std::ostream* const json = outputs.stream(arguments.json)) { *json << inspectionJson(*loaded, inspection); }
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
    addJsonArgument(command, arguments->json, "All findings and needs");
    command.flag("--strict", arguments->strict, "Exit code 1 when there is a warning");
    command.runs([arguments] { return inspect(*arguments); });
}

}  // namespace swept
