#include "commands.h"

#include <iostream>

namespace swept {

int refuse(const std::string& text) {
    std::cerr << "swept: " << text << '\n';
    return kExitBadInput;
}

std::string versionText() { return SWEPT_VERSION; }

}  // namespace swept
