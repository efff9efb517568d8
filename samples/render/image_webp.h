#pragma once

#include <memory>
#include <string>

#include "image.h"

namespace swept {

/// Writes an animated WebP without loss, picture by picture, so that only the encoded animation stays in memory.
/// Errors are kept and reported once, by `finish`.
class WebpWriter {
public:
    WebpWriter();
    ~WebpWriter();
    WebpWriter(const WebpWriter&) = delete;
    WebpWriter& operator=(const WebpWriter&) = delete;

    /// @param image        as large as the first one.
    /// @param timestampMs  when it appears, in milliseconds; 0 for the first, then strictly rising.
    /// @return false when this or an earlier picture was refused.
    bool add(const Image& image, int timestampMs);

    /// Ends the animation, which repeats for ever, and writes the file; the writer is of no use afterwards.
    /// @param endMs  when the last picture disappears; greater than the last timestamp.
    /// @return false, and "path: reason" in `error`.
    bool finish(const std::string& path, int endMs, std::string& error);

private:
    struct Encoder;
    std::unique_ptr<Encoder> encoder_;
};

}  // namespace swept
