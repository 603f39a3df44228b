// The tables on the device, one line each. GLSL (shared/buffers.glsl) and C++ (host/backend/vulkan/tables.h, passes.h)
// take their bindings, sizes, views, reading functions and byte counts from these lines. A file that includes this one
// defines TABLE before, and the kinds below where they differ from TABLE. shaders/README.md says who writes and reads
// each table.
//
//   TABLE(binding, name, element, count, title)                    elements, none of which is read through a view
//   VIEWED(binding, name, element, count, title)                   read through a texel view on devices that gain by it
//   PARAMETERS(binding, name, element, count, title)               records that no pass writes, viewed as vec4s
//   HEADED(binding, name, element, count, title, head, headName)   elements after one record of another kind
//
// `count` is made of the sizes in host/backend/vulkan/tables.h, TableCounts, and of constants of layout.h. The title is
// for messages and the manual.
#ifndef VIEWED
#define VIEWED TABLE
#endif
#ifndef PARAMETERS
#define PARAMETERS TABLE
#endif
#ifndef HEADED
#define HEADED(binding, name, element, count, title, head, headName) TABLE(binding, name, element, count, title)
#endif

// [2 halves][2 couples][particles][2 fields]: layout.h, stateOffset.
VIEWED(0, state, vec4, 2 * particles * kFields, the particle state)
// Rows: [canisters][rowEntries]: for every particle, the others within reach and skin, ascending. Then links:
// [canisters][linkEntries]: for every particle, the contacts that it takes part in, ordered as other particles by
// ascending index, surfaces, coil. A link is slot << 1, plus 1 for the contact's second body.
VIEWED(1, rows, uint, canisters * (rowEntries + linkEntries), the neighbour rows)
// [particles]: row (first, count), links (first, count). Then [particles]: own pair slots (first, count), own surface
// slots (first, count).
VIEWED(2, ranges, uvec4, 2 * particles, the ranges of rows)
// [pair and surface slots][2]: History of law/contact.glsl, zero while the two bodies do not touch. With the energy
// book, [3][slots] follows: Exerted of law/energy.glsl.
VIEWED(3, history, vec4, historyParts * springSlots, the contact history)
// [turns][parts][particles]: as the history above. Then [particles]: wire angle of each turn, kNoTurn if it is free.
// Empty without a coil.
VIEWED(4, coilHistory, vec4, coilHistoryRows * particles, the contact history with the coil)
PARAMETERS(5, members, Member, canisters, the parameters)
HEADED(6, controls, Control, canisters, the control blocks, Dispatches, dispatches)
// Heads: [canisters][cells]: the first particle of each cell, kEmpty if there is none. Then [particles]: the next in
// its cell.
TABLE(7, cells, uint, canisters * cellHeads + particles, the cell table)
// [particles]: high part of the position when the rows were built. Then [particles]: when the contacts were listed; w:
// slack.
VIEWED(8, anchors, vec4, 2 * particles, the anchors)
// [canisters][workgroups over a canister's particles].
TABLE(9, records, GroupRecord, canisters * groups, the records of the sensors)
// [slots]: the particle; then the other particle, or the surface with the number of its works in the bits above it
// (kSurfaceBits). Then [slots]: the entries that a refresh prepares.
VIEWED(10, entries, uvec2, 2 * slots, the contact lists)
// [fields][particles]; then [fields][slots]: layout.h, kBookNormal. Empty without an energy book.
TABLE(11, books, vec4, energyBook * kBookFields * (particles + slots), the energy book)
// [particles]: sum over the steps since the last sensing of the torque on the coil about +z [N m]. Empty without a
// coil.
TABLE(12, coilTorques, float, coils * particles, the torques on the coil)
// [slots]: force on the first body [N]; w: overlap over the smaller radius. Then [turns][coil slots]: the force of each
// turn.
VIEWED(13, forces, vec4, slots + kMaxTurns * coilSlots, the contact forces)
// [slots][2]: torque on the first body [N m]; w: torque on the coil about +z [N m]. Torque on the second body.
VIEWED(14, torques, vec4, 2 * slots, the contact torques)
// As the history, of the slots that a refresh prepares.
TABLE(15, carried, vec4, historyParts * springSlots, the carried history)

#undef TABLE
#undef VIEWED
#undef PARAMETERS
#undef HEADED
