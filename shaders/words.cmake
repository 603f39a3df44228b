# cmake -DSPIRV=FILE -DHEADER=FILE -DNAME=NAME -P words.cmake: writes the words of a SPIR-V file as an array of C++.
file(READ ${SPIRV} words HEX)
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1,\n" words "${words}")
file(WRITE ${HEADER} "#pragma once\n#include <cstdint>\n\nconst std::uint32_t ${NAME}[] = {\n${words}};\n")
