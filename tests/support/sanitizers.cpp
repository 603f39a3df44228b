// Linked into every program of a build with sanitizers: its settings, so that no environment has to be set.

#include <dlfcn.h>

// Leaks that are not ours: what the Vulkan loader, the drivers and their libraries keep until the process ends, and the
// fonts that cairo has looked up.
extern "C" const char* __lsan_default_suppressions() {
    return "leak:libvulkan\n"
           "leak:libvk_swiftshader\n"
           "leak:libVkLayer\n"
           "leak:libLLVM\n"
           "leak:libfontconfig\n";
}

extern "C" const char* __lsan_default_options() {
    return "print_suppressions=0";
}

// With SwiftShader's threads the leak check itself breaks off once in some hundred programs ("has encountered a fatal
// error"), when one of them ends as it stops them all. What we leak shows on lavapipe.
extern "C" int __lsan_is_turned_off() {
    return dlopen("libvk_swiftshader.so", RTLD_LAZY | RTLD_NOLOAD) != nullptr ? 1 : 0;
}

// Keeps every library loaded: a suppression goes by the library's name, and of one that was unloaded only addresses are
// left.
extern "C" int dlclose(void*) noexcept {
    return 0;
}
