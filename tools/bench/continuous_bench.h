#pragma once

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

#include <swept/samples/scene_description.h>

namespace swept::bench {

struct ContinuousBenchSettings {
    int shots = 100;  ///< a shape and speed, 1 … 2000
    std::uint64_t seed = 1;
};

/// What a mode does, over all shapes and speeds.
struct ModeRow {
    SceneContinuous mode = SceneContinuous::off;
    int shots = 0;
    int missed = 0;  ///< of shots at a wall of 2 cm: behind it at the end
    int balls = 0;
    int ballsMissed = 0;  ///< of those, balls alone
    int passers = 0;
    int ghosts = 0;          ///< of balls that pass by a post without touching it: turned aside
    double timeLost = 0;     ///< share of the hits that a ball between two walls did not make in 10 s, 60 m/s, e = 1
    double energyError = 0;  ///< of the same ball, relative, signed
    double nanoseconds = 0;  ///< a body-step, of 200 shapes at 60 m/s in a box, e = 1
    double escaped = 0;      ///< of those, share that is outside at the end
};
std::vector<ModeRow> benchModes(const ContinuousBenchSettings& settings, const std::function<void(int)>& progress);

/// "Make the wall thicker": the thinnest wall (powers of two times 1 cm) that no shot of a shape and speed passes.
struct ThicknessRow {
    std::string shape;
    SceneContinuous mode = SceneContinuous::off;
    std::vector<double> metres;  ///< by speed; 0: as thin as it gets; infinite: none tried did
};
inline constexpr double kThicknessSpeeds[] = {3, 10, 30, 100, 300, 1000};
std::vector<ThicknessRow> benchThickness(const ContinuousBenchSettings& settings,
                                         const std::function<void(int)>& progress);

void writeModeTable(std::ostream& out, const std::vector<ModeRow>& rows);
void writeThicknessTable(std::ostream& out, const std::vector<ThicknessRow>& rows);
void writeContinuousCsv(std::ostream& out, const std::vector<ModeRow>& modes, const std::vector<ThicknessRow>& walls);
/// Data and a gnuplot script for the thickness; draws it where gnuplot is installed.
/// @return what was done, in words; a reason in `error` when a file could not be written.
std::string plotThickness(const std::string& directory, const std::vector<ThicknessRow>& rows, std::string& error);

}  // namespace swept::bench
