#include "json_output.h"

#include <iostream>

#include "commands.h"

namespace swept {

void addJsonArgument(Command command, std::string& file, const std::string& what) {
    command.option("--json", file, what + " as JSON; - is standard output").type("FILE");
}

std::ostream& toldBeside(const std::string& json) { return json == "-" ? std::cerr : std::cout; }

RunFacts factsOf(const LoadedScene& loaded) {
    RunFacts facts{.engine = "swept2d " + versionText(),
                   .precision = loaded.precision == Precision::f64 ? "f64" : "f32",
                   .steps = loaded.steps};
    facts.source = loaded.source;
    return facts;
}

}  // namespace swept
