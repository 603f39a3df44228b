// The laws of the normal force, one line each. GLSL (shared/layout.h, law/normal.glsl, law/reach.glsl) and C++
// (host/law/contact_parameters.h, host/law/laws.cpp, host/backend/vulkan/tables.h) take what they know of a law from
// these lines. A file that includes this one defines LAW before. A law of the user's own is none of them.
//
//   LAW(number, Name, name, reaches, stiffens, keepsOverlap)
//
// Numbers are those of NormalLaw; User has 4. `name` begins what shaders/law/NAME.glsl answers and the function of
// host/law/NAME.cpp. The others are 0 or 1: whether contacts hold on beyond touch, whether the overlap makes sliding,
// rolling and torsion stiffer, whether a contact keeps the overlap of the last step beside its memory of one number.

LAW(0, Luding, luding, 0, 0, 0)
LAW(1, HertzMindlin, hertz, 0, 1, 0)
LAW(2, Eepa, eepa, 0, 1, 1)
LAW(3, Jkr, jkr, 1, 1, 0)

#undef LAW
