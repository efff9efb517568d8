#include "anatomy_output.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "../bench/gnuplot.h"
#include "../bench/picture_check.h"
#include "../toi/toi_anatomy.h"
#include "picture_output.h"

namespace swept {
namespace {

/// A directory of its own, gone in the end.
class Scratch {
public:
    Scratch() {
        std::error_code ignored;
        path_ = (std::filesystem::temp_directory_path(ignored) / "swept-XXXXXX").string();
        if (mkdtemp(path_.data()) == nullptr) { path_.clear(); }
    }
    ~Scratch() {
        std::error_code ignored;
        if (!path_.empty()) { std::filesystem::remove_all(path_, ignored); }
    }
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;
    const std::string& path() const { return path_; }

private:
    std::string path_;
};

/// The picture is drawn beside its place: whether all of it arrives there is then for us to see.
constexpr const char* kDrawn = "anatomy.png";

/// @return the bytes of the picture; empty, and the reason in `error`, when it was not drawn
std::string drawnBy(const std::string& script, std::string& error) {
    const Scratch scratch;
    std::ofstream file(scratch.path() + "/anatomy.gp", std::ios::binary);
    file << script;
    file.close();
    if (!file) {
        error = "the temporary directory cannot be written";
        return "";
    }
    switch (bench::runGnuplot(scratch.path(), "anatomy.gp")) {
        case bench::GnuplotState::drawn:
            break;
        case bench::GnuplotState::notInstalled:
            error = "gnuplot, which draws the picture, is not installed";
            return "";
        case bench::GnuplotState::refused:
            error = "gnuplot could not draw the picture";
            return "";
    }
    const std::string picture = scratch.path() + '/' + kDrawn;
    if (!bench::isCompletePicture(picture)) {
        error = "gnuplot could not write the picture into the temporary directory";
        return "";
    }
    std::ifstream bytes(picture, std::ios::binary);
    return {std::istreambuf_iterator<char>(bytes), {}};
}

}  // namespace

bool AnatomyPicture::open(const std::string& file, const std::string& input, std::string& error) {
    file_ = file;
    files_.protect(input);
    files_.addFile("--anatomy", file);
    if (files_.refuseClashes(error)) { error = endingFault("--anatomy", file, "PNG"); }
    return error.empty() && files_.open(error);
}

bool AnatomyPicture::draw(const ToiQuery& query, std::string& error) {
    const std::string picture = drawnBy(anatomyScript(dissectToi(query), kDrawn), error);
    if (picture.empty()) {
        error = "--anatomy " + file_ + ": " + error;
        files_.discard();
        return false;
    }
    *files_.stream(file_) << picture;
    return files_.close(error);
}

}  // namespace swept
