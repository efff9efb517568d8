#include "anatomy_output.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "../bench/gnuplot.h"
#include "../output_files.h"
#include "../toi_anatomy.h"

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

bool runScript(const std::string& script, std::string& error) {
    const Scratch scratch;
    std::ofstream file(scratch.path() + "/anatomy.gp", std::ios::binary);
    file << script;
    file.close();
    if (!file) {
        error = "the temporary directory cannot be written";
        return false;
    }
    switch (bench::runGnuplot(scratch.path(), "anatomy.gp")) {
        case bench::GnuplotState::drawn:
            return true;
        case bench::GnuplotState::notInstalled:
            error = "gnuplot, which draws the picture, is not installed";
            return false;
        case bench::GnuplotState::refused:
            error = "gnuplot could not draw the picture";
            return false;
    }
    return false;  // unreachable, but GCC cannot know
}

}  // namespace

bool drawAnatomy(const ToiQuery& query, const std::string& file, const std::string& input, std::string& error) {
    OutputFiles files;
    files.protect(input);
    files.addFile("--anatomy", file);
    if (!files.open(error)) { return false; }
    if (!runScript(anatomyScript(dissectToi(query), std::filesystem::absolute(file).string()), error)) {
        files.discard();
        return false;
    }
    return files.close(error);
}

}  // namespace swept
