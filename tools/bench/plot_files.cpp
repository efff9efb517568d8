#include "plot_files.h"

#include <filesystem>
#include <fstream>
#include <system_error>

#include "gnuplot.h"
#include "picture_check.h"

namespace swept::bench {
namespace {

bool writeFile(const std::string& path, const std::function<void(std::ostream&)>& write, std::string& error) {
    std::ofstream file(path, std::ios::binary);
    write(file);
    file.close();
    if (!file) { error = path + ": cannot be written"; }
    return error.empty();
}

std::string dataOf(const PlotFiles& plot) { return plot.name + ".dat"; }
std::string scriptOf(const PlotFiles& plot) { return plot.name + ".gp"; }
std::string pictureOf(const PlotFiles& plot) { return plot.name + ".png"; }

std::vector<std::string> picturesOf(const std::string& directory, const PlotFiles& plot) {
    std::vector<std::string> pictures{directory + '/' + pictureOf(plot)};
    for (const std::string& other : plot.others) { pictures.push_back(directory + '/' + other); }
    return pictures;
}

/// A complete one of an earlier run would be taken for one of this run.
void removeOldPictures(const std::string& directory, const PlotFiles& plot) {
    std::error_code ignored;
    for (const std::string& picture : picturesOf(directory, plot)) {
        if (std::filesystem::is_regular_file(std::filesystem::symlink_status(picture, ignored))) {
            std::filesystem::remove(picture, ignored);
        }
    }
}

bool areDrawn(const std::string& directory, const PlotFiles& plot, std::string& error) {
    for (const std::string& picture : picturesOf(directory, plot)) {
        if (isCompletePicture(picture)) { continue; }
        error = picture + ": could not be written to the end";
        return false;
    }
    return true;
}

}  // namespace

const char* const kPlotStyle =
    "set terminal pngcairo size 960,600 font 'sans,12'\n"
    "set border 3\nset tics nomirror\nset grid lc rgb '#dddddd' lw 1\n"
    "set style line 1 lc rgb '#d62728' pt 7\nset style line 2 lc rgb '#999999' pt 1\n"
    "set style line 3 lc rgb '#8c564b' pt 2\nset style line 4 lc rgb '#2ca02c' pt 5\n"
    "set style line 5 lc rgb '#1f77b4' pt 9\nset style line 6 lc rgb '#ff7f0e' pt 11\n"
    "set style line 7 lc rgb '#9467bd' pt 13\nset style line 8 lc rgb '#17becf' pt 4\n"
    "set style line 9 lc rgb '#000000' pt 6\nset style line 10 lc rgb '#e377c2' pt 3\n";

std::vector<std::string> filesOf(const PlotFiles& plot) {
    std::vector<std::string> files{dataOf(plot), scriptOf(plot), pictureOf(plot)};
    files.insert(files.end(), plot.others.begin(), plot.others.end());
    return files;
}

std::string drawPlots(const std::string& directory, const std::vector<PlotFiles>& plots, std::string& error) {
    for (const PlotFiles& plot : plots) {
        if (!writeFile(directory + '/' + dataOf(plot), plot.data, error) ||
            !writeFile(directory + '/' + scriptOf(plot), plot.script, error)) {
            return "";
        }
    }
    std::string drawn;
    for (const PlotFiles& plot : plots) {
        removeOldPictures(directory, plot);
        switch (runGnuplot(directory, scriptOf(plot))) {
            case GnuplotState::drawn:
                if (!areDrawn(directory, plot, error)) { return ""; }
                drawn += (drawn.empty() ? "" : ", ") + directory + '/' + pictureOf(plot);
                break;
            case GnuplotState::notInstalled:
                return "gnuplot is not installed: data and scripts are in " + directory + ", no plots were drawn";
            case GnuplotState::refused:
                error = directory + '/' + scriptOf(plot) + ": gnuplot could not draw it";
                return "";
        }
    }
    return "drawn: " + drawn;
}

}  // namespace swept::bench
