#pragma once

#include <GL/osmesa.h>

#include <string>

namespace swept {

/// What is used of OSMesa, and of OpenGL in it. The library is loaded when the first picture is drawn: with it come
/// compilers of shaders and more, and programs that draw nothing would wait 0.1 s for them to be linked.
struct OsMesa {
    decltype(&::OSMesaCreateContextExt) createContext = nullptr;
    decltype(&::OSMesaDestroyContext) destroyContext = nullptr;
    decltype(&::OSMesaMakeCurrent) makeCurrent = nullptr;
    decltype(&::OSMesaPixelStore) pixelStore = nullptr;

    decltype(&::glBlendFunc) blendFunc = nullptr;
    decltype(&::glClear) clear = nullptr;
    decltype(&::glClearColor) clearColor = nullptr;
    decltype(&::glColorPointer) colorPointer = nullptr;
    decltype(&::glDisable) disable = nullptr;
    decltype(&::glDrawArrays) drawArrays = nullptr;
    decltype(&::glEnable) enable = nullptr;
    decltype(&::glEnableClientState) enableClientState = nullptr;
    decltype(&::glFinish) finish = nullptr;
    decltype(&::glLoadIdentity) loadIdentity = nullptr;
    decltype(&::glMatrixMode) matrixMode = nullptr;
    decltype(&::glOrtho) ortho = nullptr;
    decltype(&::glVertexPointer) vertexPointer = nullptr;
    decltype(&::glViewport) viewport = nullptr;

    std::string error;  ///< empty, or why it cannot be used
};

/// Loaded by the first call; it stays until the program ends.
const OsMesa& osMesa();

}  // namespace swept
