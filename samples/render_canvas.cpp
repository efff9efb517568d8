#include "render_canvas.h"

#include <GL/osmesa.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define SWEPT_LEAK_CHECK
#endif
#elif defined(__SANITIZE_ADDRESS__)
#define SWEPT_LEAK_CHECK
#endif

#ifdef SWEPT_LEAK_CHECK
// OSMesa 22 does not free a small record of the framebuffer of each context; programs checked for leaks would fail by
// it. The name is that which the sanitizer's runtime looks for.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libOSMesa\n"; }
#endif

namespace swept {

namespace {

constexpr int kLargestPicture = 8192;
constexpr int kLargestFramebuffer = 16384;  // what Mesa's software rasterisers take in one direction

struct ContextDeleter {
    void operator()(osmesa_context* context) const { OSMesaDestroyContext(context); }
};

}  // namespace

struct RenderCanvas::Target {
    std::unique_ptr<osmesa_context, ContextDeleter> context;
    int width = 0;
    int height = 0;
    int factor = 1;
    std::vector<std::uint8_t> rgba;

    bool makeCurrent() {
        return OSMesaMakeCurrent(context.get(), rgba.data(), GL_UNSIGNED_BYTE, width * factor, height * factor) ==
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
    auto target = std::make_unique<Target>();
    target->width = width;
    target->height = height;
    target->factor = std::clamp(superSampling, 1, kLargestFramebuffer / std::max(width, height));
    const auto side = static_cast<std::size_t>(target->factor);
    target->rgba.resize(4 * side * side * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    target->context.reset(OSMesaCreateContextExt(OSMESA_RGBA, 0, 0, 0, nullptr));
    if (!target->context || !target->makeCurrent()) {
        error = "OSMesa gives no context of this size";
        return nullptr;
    }
    OSMesaPixelStore(OSMESA_Y_UP, 0);  // rows from top to bottom, as pictures have them
    return std::unique_ptr<RenderCanvas>(new RenderCanvas(std::move(target)));
}

Image RenderCanvas::draw(Color background, std::span<const PaintVertex> triangles) {
    Target& target = *target_;
    if (!target.makeCurrent()) { return {}; }
    constexpr float kByte = 1.0f / 255.0f;
    glViewport(0, 0, target.width * target.factor, target.height * target.factor);
    glDisable(GL_DITHER);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glOrtho(0, target.width, 0, target.height, -1, 1);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glClearColor(static_cast<float>(background.red) * kByte, static_cast<float>(background.green) * kByte,
                 static_cast<float>(background.blue) * kByte, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    if (!triangles.empty()) {
        glEnableClientState(GL_VERTEX_ARRAY);
        glEnableClientState(GL_COLOR_ARRAY);
        glVertexPointer(2, GL_FLOAT, sizeof(PaintVertex), &triangles.front().x);
        glColorPointer(4, GL_UNSIGNED_BYTE, sizeof(PaintVertex), &triangles.front().color);
        glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(triangles.size()));
    }
    glFinish();
    return downsample(target.rgba, target.width, target.height, target.factor);
}

}  // namespace swept
