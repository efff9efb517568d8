#include "picture_check.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <system_error>

namespace swept::bench {
namespace {

constexpr std::string_view kPngStart = "\x89PNG\r\n\x1a\n";
/// The last chunk, which is empty, with its checksum.
constexpr std::string_view kPngEnd{"\0\0\0\0IEND\xae\x42\x60\x82", 12};
constexpr std::string_view kSvgEnd = "</svg>";

}  // namespace

bool isCompletePicture(const std::string& path) {
    namespace fs = std::filesystem;
    std::error_code ignored;
    if (!fs::is_regular_file(path, ignored)) { return false; }  // to read a device or a pipe may take for ever
    std::ifstream file(path, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(file)), {});
    if (fs::path(path).extension() == ".svg") { return bytes.rfind(kSvgEnd) != std::string::npos; }
    return bytes.starts_with(kPngStart) && bytes.ends_with(kPngEnd);
}

}  // namespace swept::bench
