#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "world_bench.h"

namespace swept::worlds {

/// Time of a step, times over those of `kRival`, stages, memory, quality.
void writeWorldTables(std::ostream& out, const std::vector<WorldRow>& rows);
/// Time of a step for each joint, over those of `kRival`, gaps of joints.
void writeJointTables(std::ostream& out, const std::vector<WorldRow>& rows);
/// Cost of a step over the number of bodies.
void writeGrowthTable(std::ostream& out, const std::vector<WorldRow>& rows);
void writeWorldCsv(std::ostream& out, const std::vector<WorldRow>& rows);

/// Draws times and growth. @return what was drawn, or why not; `error` when a file could not be written or drawn
std::string plotWorlds(const std::string& directory, const std::vector<WorldRow>& rows,
                       const std::vector<WorldRow>& growth, std::string& error);

}  // namespace swept::worlds
