// Linked into every program of a build with sanitizers: its settings, so that no environment has to be set.

// Leaks that are not ours: what the Vulkan loader, the drivers and their libraries keep until the process ends.
extern "C" const char* __lsan_default_suppressions() {
    return "leak:libvulkan\n"
           "leak:libvk_swiftshader\n"
           "leak:libVkLayer\n"
           "leak:libLLVM\n";
}

extern "C" const char* __lsan_default_options() {
    return "print_suppressions=0";
}

// Keeps every library loaded: a suppression goes by the library's name, and of one that was unloaded only addresses are left.
extern "C" int dlclose(void*) noexcept {
    return 0;
}
