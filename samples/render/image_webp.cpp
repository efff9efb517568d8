#include "image_webp.h"

#include <webp/encode.h>
#include <webp/mux.h>

#include "image_file.h"

namespace swept {

struct WebpWriter::Encoder {
    WebPAnimEncoder* animation = nullptr;
    int width = 0;
    int height = 0;
    int lastTimestamp = -1;
    std::string error;

    ~Encoder() { WebPAnimEncoderDelete(animation); }
    bool start(const Image& image);
    bool encode(const Image& image, int timestampMs);
    bool fail(const char* reason) {
        error = reason;
        return false;
    }
};

bool WebpWriter::Encoder::start(const Image& image) {
    WebPAnimEncoderOptions options;
    if (WebPAnimEncoderOptionsInit(&options) == 0) { return fail("the WebP library has another version"); }
    options.anim_params.loop_count = 0;
    animation = WebPAnimEncoderNew(image.width, image.height, &options);
    if (animation == nullptr) { return fail("the WebP encoder refuses this size"); }
    width = image.width;
    height = image.height;
    return true;
}

bool WebpWriter::Encoder::encode(const Image& image, int timestampMs) {
    WebPConfig config;
    if (WebPConfigInit(&config) == 0) { return fail("the WebP library has another version"); }
    // Flat colours are smaller without loss than with it, and keep their crisp edges. Higher methods gain few per cent.
    config.lossless = 1;
    config.method = 1;
    config.quality = 40;
    WebPPicture picture;
    if (WebPPictureInit(&picture) == 0) { return fail("the WebP library has another version"); }
    picture.use_argb = 1;
    picture.width = image.width;
    picture.height = image.height;
    bool added = WebPPictureImportRGB(&picture, image.rgb.data(), 3 * image.width) != 0;
    added = added && WebPAnimEncoderAdd(animation, &picture, timestampMs, &config) != 0;
    WebPPictureFree(&picture);
    return added || fail(WebPAnimEncoderGetError(animation));
}

WebpWriter::WebpWriter() : encoder_(std::make_unique<Encoder>()) {}
WebpWriter::~WebpWriter() = default;

bool WebpWriter::add(const Image& image, int timestampMs) {
    Encoder& encoder = *encoder_;
    if (!encoder.error.empty()) { return false; }
    if (image.empty()) { return encoder.fail("a picture is empty"); }
    if (encoder.animation == nullptr && !encoder.start(image)) { return false; }
    if (image.width != encoder.width || image.height != encoder.height) {
        return encoder.fail("the pictures of an animation must have one size");
    }
    if (timestampMs <= encoder.lastTimestamp) { return encoder.fail("the timestamps of an animation must rise"); }
    encoder.lastTimestamp = timestampMs;
    return encoder.encode(image, timestampMs);
}

bool WebpWriter::finish(const std::string& path, int endMs, std::string& error) {
    Encoder& encoder = *encoder_;
    if (encoder.error.empty() && encoder.animation == nullptr) { encoder.fail("an animation needs a picture"); }
    if (encoder.error.empty() && endMs <= encoder.lastTimestamp) { encoder.fail("the last picture needs a duration"); }
    WebPData data{};
    if (encoder.error.empty() && (WebPAnimEncoderAdd(encoder.animation, nullptr, endMs, nullptr) == 0 ||
                                  WebPAnimEncoderAssemble(encoder.animation, &data) == 0)) {
        encoder.fail(WebPAnimEncoderGetError(encoder.animation));
    }
    if (!encoder.error.empty()) {
        error = path + ": " + encoder.error;
        return false;
    }
    const bool written = writeImageFile(data.bytes, data.size, path, error);
    WebPDataClear(&data);
    return written;
}

}  // namespace swept
