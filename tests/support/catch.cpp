// Nothing: a precompiled header belongs to a target with a source (tests/CMakeLists.txt).
