#pragma once

#include <string>

namespace swept {

/// Takes away a file that could not be written to the end. Only a regular file, also behind a link, and the link
/// itself: devices, pipes and directories stay.
void removeBegunFile(const std::string& path);

}  // namespace swept
