#include "begun_file.h"

#include <filesystem>
#include <system_error>

namespace swept {

void removeBegunFile(const std::string& path) {
    namespace fs = std::filesystem;
    std::error_code ignored;
    if (fs::is_regular_file(fs::status(path, ignored))) { fs::remove(fs::canonical(path, ignored), ignored); }
    if (fs::is_symlink(fs::symlink_status(path, ignored))) { fs::remove(path, ignored); }
}

}  // namespace swept
