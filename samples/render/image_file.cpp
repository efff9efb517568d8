#include "image_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "../begun_file.h"

namespace swept {

bool writeImageFile(const std::uint8_t* bytes, std::size_t size, const std::string& path, std::string& error) {
    std::FILE* const file = std::fopen(path.c_str(), "wb");
    if (file == nullptr) {
        error = path + ": " + std::strerror(errno);
        return false;
    }
    const bool written = std::fwrite(bytes, 1, size, file) == size;
    const int writeError = errno;
    const bool closed = std::fclose(file) == 0;
    if (written && closed) { return true; }
    error = path + ": " + std::strerror(written ? errno : writeError);
    removeBegunFile(path);
    return false;
}

}  // namespace swept
