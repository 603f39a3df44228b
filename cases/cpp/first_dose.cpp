// first_dose CASE.toml [vulkan|reference]: the doses of a case as they end, computed in this process.

#include <host/play/backend_choice.h>
#include <host/play/simulation.h>

#include <chrono>
#include <exception>
#include <iostream>

int main(int argc, char** argv) {
    if (argc < 2) {
        std::cerr << "usage: first_dose CASE.toml [vulkan|reference]\n";
        return 2;
    }
    try {
        vkdose::BackendChoice choice;
        if (argc > 2) choice.backend = argv[2];
        vkdose::Simulation run(vkdose::loadCase(argv[1]), vkdose::openBackend(choice));
        std::size_t told = 0;
        while (!run.over()) {
            run.advanceToDose();
            while (!run.awaitRest(std::chrono::seconds(1))) {
            }
            for (; told < run.doses().size(); ++told)
                std::cout << "dose " << told + 1 << ": " << run.doses()[told].mass * 1e3 << " g\n";
        }
    } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
        return 1;
    }
}
