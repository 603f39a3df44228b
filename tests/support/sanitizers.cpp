// The settings of the sanitizers. Linked into every program of a build with sanitizers, so that no environment has to
// be set.

#include <dlfcn.h>

// Leaks that are not ours. The Vulkan loader, the drivers and their libraries keep memory until the process ends, cairo
// keeps the fonts that it has looked up, and the C library the folders of LOCPATH.
extern "C" const char* __lsan_default_suppressions() {
    return "leak:libvulkan\n"
           "leak:libvk_swiftshader\n"
           "leak:libVkLayer\n"
           "leak:libLLVM\n"
           "leak:libfontconfig\n"
           "leak:__argz_add_sep\n";
}

extern "C" const char* __lsan_default_options() {
    return "print_suppressions=0";
}

// The leak check stops all threads. If one of SwiftShader's threads ends meanwhile, the check itself breaks off ("has
// encountered a fatal error"), once in some hundred programs. So it is off with SwiftShader; our leaks show on
// lavapipe.
extern "C" int __lsan_is_turned_off() {
    return dlopen("libvk_swiftshader.so", RTLD_LAZY | RTLD_NOLOAD) != nullptr ? 1 : 0;
}

// Keeps every library loaded. A suppression goes by the name of a library, and the report has only addresses for a
// library that was unloaded.
extern "C" int dlclose(void*) noexcept {
    return 0;
}
