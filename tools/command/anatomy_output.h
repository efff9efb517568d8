#pragma once

#include <string>

#include "../toi/toi_query.h"
#include "../writers/output_files.h"

namespace swept {

/// The anatomy of a query (toi_anatomy.h) as a PNG, drawn by gnuplot.
class AnatomyPicture {
public:
    /// @param input  where the query came from: it is not overwritten; empty: no file
    /// @return false, and one line in `error`, when the file cannot be written
    bool open(const std::string& file, const std::string& input, std::string& error);
    /// To be called once, when it is open.
    /// @return false, and one line in `error`, when gnuplot is missing or the picture was not written to the end; then
    /// no file is left.
    bool draw(const ToiQuery& query, std::string& error);

private:
    std::string file_;
    OutputFiles files_;
};

}  // namespace swept
