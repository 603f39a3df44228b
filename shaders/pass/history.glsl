// The history of a contact in its slot.
#ifndef VKDOSE_PASS_HISTORY_GLSL
#define VKDOSE_PASS_HISTORY_GLSL

#include "law/contact.glsl"

History historyOfSlot(uint slot) {
    History h;
    h.slidingMax = readHistory(0u, slot);
    h.rollingTorsion = readHistory(1u, slot);
#ifdef USER_LAW
    h.own[0] = readHistory(kOwnPart, slot);
    h.own[1] = readHistory(kOwnPart + 1u, slot);
#else
    h.last = 0.0;
    if (kParts > kOwnPart) h.last = readHistory(kOwnPart, slot).x;
#endif
    return h;
}

/// A contact that does not touch remembers nothing.
void keepHistory(uint slot, History h, bool touching) {
    writeHistory(slot, touching ? h.slidingMax : vec4(0.0), touching ? h.rollingTorsion : vec4(0.0));
#ifdef USER_LAW
    history[historyIndex(kOwnPart, slot)] = touching ? h.own[0] : vec4(0.0);
    history[historyIndex(kOwnPart + 1u, slot)] = touching ? h.own[1] : vec4(0.0);
#else
    if (kParts > kOwnPart) history[historyIndex(kOwnPart, slot)] = vec4(touching ? h.last : 0.0, 0.0, 0.0, 0.0);
#endif
}

History historyOfPlace(uint slot, uint place) {
    History h;
    h.slidingMax = historyAt(placeHistoryIndex(slot, place, 0u));
    h.rollingTorsion = historyAt(placeHistoryIndex(slot, place, 1u));
#ifdef USER_LAW
    h.own[0] = historyAt(placeHistoryIndex(slot, place, kOwnPart + 1u));
    h.own[1] = historyAt(placeHistoryIndex(slot, place, kOwnPart + 2u));
#else
    h.last = 0.0;
    if (kParts > kOwnPart) h.last = historyAt(placeHistoryIndex(slot, place, kOwnPart + 1u)).x;
#endif
    return h;
}

/// The direction of the place is kept beside it.
void keepHistoryOfPlace(uint slot, uint place, History h) {
    history[placeHistoryIndex(slot, place, 0u)] = h.slidingMax;
    history[placeHistoryIndex(slot, place, 1u)] = h.rollingTorsion;
#ifdef USER_LAW
    history[placeHistoryIndex(slot, place, kOwnPart + 1u)] = h.own[0];
    history[placeHistoryIndex(slot, place, kOwnPart + 2u)] = h.own[1];
#else
    if (kParts > kOwnPart) history[placeHistoryIndex(slot, place, kOwnPart + 1u)] = vec4(h.last, 0.0, 0.0, 0.0);
#endif
}

#endif
