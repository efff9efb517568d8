#pragma once

#include <cstdint>
#include <string>
#include <vector>

/// What `swept inspect` has to say about a scene.

namespace swept {

enum class Severity : std::uint8_t {
    note,     ///< worth knowing; the run will be right
    warning,  ///< outside the measured envelope: the run may be wrong
};

/// One thing that a user should know before anything runs.
struct Finding {
    Severity severity = Severity::note;
    std::string kind;    ///< one of the words that tools/README.md explains: "mass-ratio", "far-away" …
    std::string where;   ///< JSON pointer of the culprit
    std::string text;    ///< what was found, with its numbers
    std::string remedy;  ///< what would mend it; may be empty
};

/// Whether a scene can reach a feature of the engine at all.
struct Need {
    std::string feature;  ///< "continuous collision", "restitution" …
    bool needed = false;
    std::string reason;  ///< which body or number decides it
};

struct Inspection {
    std::vector<Finding> findings;  ///< warnings first, then in the order of the scene
    std::vector<Need> needs;
};

}  // namespace swept
