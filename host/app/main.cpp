#include "host/app/command_line.h"
#include "host/app/limits.h"

int main(int argc, char** argv) {
    return vkdose::withinLimits([&] { return vkdose::commandLine(argc, argv); });
}
