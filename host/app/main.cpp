#include "host/app/command_line.h"

int main(int argc, char** argv) {
    return vkdose::commandLine(argc, argv);
}
