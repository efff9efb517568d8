#pragma once

#include <cstddef>
#include <iosfwd>
#include <string>
#include <vector>

#include <swept/samples/frame.h>

namespace swept {

/// A field of a CSV record, quoted by RFC 4180 when it has to be (comma, quote, line break).
std::string csvField(const std::string& text);

/// The state of every body after every step: `step,time,body,x,y,angle,vx,vy,omega,awake`, one row a body, in scene
/// order, rows end with a line feed. Numbers are the shortest decimals that read back as the same double.
class CsvWriter {
public:
    /// Writes the header. `out` must outlive the writer.
    /// @param bodies  indices of those that are written, in any order; none: all.
    CsvWriter(std::ostream& out, const std::vector<std::string>& bodyNames,
              const std::vector<std::size_t>& bodies = {});
    /// One row for each body of the frame that is written.
    void write(const Frame& frame);

private:
    std::ostream& out_;
    std::vector<std::string> fields_;  // body names, quoted
    std::vector<bool> written_;        // of each body
    std::string rows_;                 // text of one frame, its capacity reused
};

}  // namespace swept
