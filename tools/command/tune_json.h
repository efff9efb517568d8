#pragma once

#include <string>
#include <vector>

#include "../tune/ablation.h"
#include "../tune/verdict.h"
#include "../writers/report_writer.h"

/// What `swept tune` tells other programs.

namespace swept {

/// What both kinds of answers are about.
struct TuneQuestion {
    RunFacts facts;
    const tune::Subject& subject;
    const std::vector<tune::Limit>& limits;
    const tune::Knowledge& known;
};

/// All rows, the cheapest first, and the advice.
/// @param tuned  file of the recommended scene
std::string adviceJson(const TuneQuestion& question, const tune::Verdict& verdict, const std::string& tuned);

/// What the scene can do without.
/// @param lean  file of the leanest scene
std::string ablationJson(const TuneQuestion& question, const tune::Ablation& ablation, const std::string& lean);

}  // namespace swept
