#include "osmesa.h"

#include <dlfcn.h>

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

class Loader {
public:
    Loader() : library_(dlopen(SWEPT_OSMESA_LIBRARY, RTLD_NOW | RTLD_LOCAL)) {
        if (library_ == nullptr) { mesa_.error = dlerror(); }
    }

    template <class Function>
    void find(const char* name, Function OsMesa::*function) {
        if (!mesa_.error.empty()) { return; }
        mesa_.*function = reinterpret_cast<Function>(dlsym(library_, name));
        if (mesa_.*function == nullptr) { mesa_.error = std::string(SWEPT_OSMESA_LIBRARY) + " has no " + name; }
    }

    OsMesa result() const { return mesa_; }

private:
    OsMesa mesa_;
    void* library_;
};

OsMesa load() {
    Loader loader;
    loader.find("OSMesaCreateContextExt", &OsMesa::createContext);
    loader.find("OSMesaDestroyContext", &OsMesa::destroyContext);
    loader.find("OSMesaMakeCurrent", &OsMesa::makeCurrent);
    loader.find("OSMesaPixelStore", &OsMesa::pixelStore);
    loader.find("glBlendFunc", &OsMesa::blendFunc);
    loader.find("glClear", &OsMesa::clear);
    loader.find("glClearColor", &OsMesa::clearColor);
    loader.find("glColorPointer", &OsMesa::colorPointer);
    loader.find("glDisable", &OsMesa::disable);
    loader.find("glDrawArrays", &OsMesa::drawArrays);
    loader.find("glEnable", &OsMesa::enable);
    loader.find("glEnableClientState", &OsMesa::enableClientState);
    loader.find("glFinish", &OsMesa::finish);
    loader.find("glLoadIdentity", &OsMesa::loadIdentity);
    loader.find("glMatrixMode", &OsMesa::matrixMode);
    loader.find("glOrtho", &OsMesa::ortho);
    loader.find("glVertexPointer", &OsMesa::vertexPointer);
    loader.find("glViewport", &OsMesa::viewport);
    return loader.result();
}

}  // namespace

const OsMesa& osMesa() {
    static const OsMesa mesa = load();
    return mesa;
}

}  // namespace swept
