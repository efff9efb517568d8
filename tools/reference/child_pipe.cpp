#include "child_pipe.h"

#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>

namespace swept {

bool readAll(void* target, std::size_t size) {
    auto* bytes = static_cast<char*>(target);
    while (size > 0) {
        const ssize_t count = read(STDIN_FILENO, bytes, size);
        if (count < 0 && errno == EINTR) { continue; }
        if (count <= 0) { return false; }
        bytes += count;
        size -= static_cast<std::size_t>(count);
    }
    return true;
}

bool writeAll(const void* source, std::size_t size) {
    const auto* bytes = static_cast<const char*>(source);
    while (size > 0) {
        const ssize_t count = write(STDOUT_FILENO, bytes, size);
        if (count < 0 && errno == EINTR) { continue; }
        if (count <= 0) { return false; }
        bytes += count;
        size -= static_cast<std::size_t>(count);
    }
    return true;
}

void forbidDumps() {
    const rlimit none{0, 0};
    setrlimit(RLIMIT_CORE, &none);
}

}  // namespace swept
