#include "render_canvas.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "osmesa.h"

namespace swept {

namespace {

constexpr int kLargestFramebuffer = 16384;  // what Mesa's software rasterisers take in one direction

struct ContextDeleter {
    void operator()(osmesa_context* context) const { osMesa().destroyContext(context); }
};

}  // namespace

struct RenderCanvas::Target {
    std::unique_ptr<osmesa_context, ContextDeleter> context;
    int width = 0;
    int height = 0;
    int factor = 1;
    std::vector<std::uint8_t> rgba;

    bool makeCurrent() {
        return osMesa().makeCurrent(context.get(), rgba.data(), GL_UNSIGNED_BYTE, width * factor, height * factor) ==
               GL_TRUE;
    }
};

RenderCanvas::RenderCanvas(std::unique_ptr<Target> target) : target_(std::move(target)) {}
RenderCanvas::~RenderCanvas() = default;

std::unique_ptr<RenderCanvas> RenderCanvas::create(int width, int height, int superSampling, std::string& error) {
    if (width < 1 || height < 1 || width > kLargestPicture || height > kLargestPicture) {
        error = "a picture must have 1 to " + std::to_string(kLargestPicture) + " pixels in each direction";
        return nullptr;
    }
    const OsMesa& gl = osMesa();
    if (!gl.error.empty()) {
        error = "OSMesa cannot be loaded: " + gl.error;
        return nullptr;
    }
    auto target = std::make_unique<Target>();
    target->width = width;
    target->height = height;
    target->factor = std::clamp(superSampling, 1, kLargestFramebuffer / std::max(width, height));
    const auto side = static_cast<std::size_t>(target->factor);
    target->rgba.resize(4 * side * side * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    target->context.reset(gl.createContext(OSMESA_RGBA, 0, 0, 0, nullptr));
    if (!target->context || !target->makeCurrent()) {
        error = "OSMesa gives no context of this size";
        return nullptr;
    }
    gl.pixelStore(OSMESA_Y_UP, 0);  // rows from top to bottom, as pictures have them
    return std::unique_ptr<RenderCanvas>(new RenderCanvas(std::move(target)));
}

Image RenderCanvas::draw(Color background, std::span<const PaintVertex> triangles) {
    Target& target = *target_;
    if (!target.makeCurrent()) { return {}; }
    const OsMesa& gl = osMesa();
    constexpr float kByte = 1.0f / 255.0f;
    gl.viewport(0, 0, target.width * target.factor, target.height * target.factor);
    gl.disable(GL_DITHER);
    gl.enable(GL_BLEND);
    gl.blendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    gl.matrixMode(GL_PROJECTION);
    gl.loadIdentity();
    gl.ortho(0, target.width, 0, target.height, -1, 1);
    gl.matrixMode(GL_MODELVIEW);
    gl.loadIdentity();
    gl.clearColor(static_cast<float>(background.red) * kByte, static_cast<float>(background.green) * kByte,
                  static_cast<float>(background.blue) * kByte, 1);
    gl.clear(GL_COLOR_BUFFER_BIT);
    if (!triangles.empty()) {
        gl.enableClientState(GL_VERTEX_ARRAY);
        gl.enableClientState(GL_COLOR_ARRAY);
        gl.vertexPointer(2, GL_FLOAT, sizeof(PaintVertex), &triangles.front().x);
        gl.colorPointer(4, GL_UNSIGNED_BYTE, sizeof(PaintVertex), &triangles.front().color);
        gl.drawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(triangles.size()));
    }
    gl.finish();
    return downsample(target.rgba, target.width, target.height, target.factor);
}

}  // namespace swept
