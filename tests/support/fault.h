#pragma once
// Runs what follows on a spoilt device: the layer of fault_layer.cpp, chosen through the loader's environment.

#include <cstdlib>
#include <string>

namespace vkdose::test {

/// While it lives, every Vulkan instance of this process, and of the processes that it starts, has the faults of
/// `names` (see fault_layer.cpp). The validation layer, where a test loads it, stands above and takes the spoilt device
/// for the real one.
class Fault {
  public:
    explicit Fault(const std::string& names, bool validated = true) {
        setenv("VKDOSE_FAULT", names.c_str(), 1);
        // The layer found last stands next to the driver: the system's folders, with the validation layer, come first.
        setenv("VK_ADD_LAYER_PATH", "/etc/vulkan/explicit_layer.d:/usr/share/vulkan/explicit_layer.d:" VKDOSE_LAYER_DIR,
               1);
        const char* layers = "VK_LAYER_KHRONOS_validation:VK_LAYER_VKDOSE_faults";
        setenv("NODEVICE_SELECT", "1", 1);  // Mesa's own layer overruns its list when there is no device
        setenv("VK_INSTANCE_LAYERS", validated ? layers : "VK_LAYER_VKDOSE_faults", 1);
    }
    ~Fault() {
        for (const char* name : {"VKDOSE_FAULT", "VK_ADD_LAYER_PATH", "VK_INSTANCE_LAYERS", "NODEVICE_SELECT"})
            unsetenv(name);
    }
    Fault(const Fault&) = delete;
    Fault& operator=(const Fault&) = delete;
};

}  // namespace vkdose::test
