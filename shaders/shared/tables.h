// The tables on the device, one line each. GLSL (shared/buffers.glsl) and C++ (host/backend/vulkan/tables.h, passes.h)
// take their bindings, sizes, views, reading functions, index functions and byte counts from these lines. A file that
// includes this one defines TABLE before, and the kinds below where they differ from TABLE. shaders/README.md says who
// writes and reads each table.
//
//   TABLE(binding, name, element, count, title)                    elements, none of which is read through a view
//   VIEWED(binding, name, element, count, title)                   read through a texel view on processors
//   PARAMETERS(binding, name, element, count, title)               records that no pass writes, viewed as vec4s
//   HEADED(binding, name, element, count, title, head, headName)   elements after one record of another kind
//
// Below a table that has several parts, or rows, there is a line for each part. The line makes a function that says
// where in the table an element is. The parts follow one another and fill the table (tests/layout).
//
//   ROW(table, function, first, length)           function(i) = first + i
//   ROWS(table, function, first, rows, length)    function(row, i) = first + row * length + i
//
// All numbers are made of the sizes in host/backend/vulkan/tables.h, TableCounts, and of constants of layout.h. The
// title is for messages and the manual.
#ifndef VIEWED
#define VIEWED TABLE
#endif
#ifndef PARAMETERS
#define PARAMETERS TABLE
#endif
#ifndef HEADED
#define HEADED(binding, name, element, count, title, head, headName) TABLE(binding, name, element, count, title)
#endif
#ifndef ROW
#define ROW(table, function, first, length)
#endif
#ifndef ROWS
#define ROWS(table, function, first, rows, length)
#endif

// [2 halves][2 couples][particles][2 fields]: layout.h, stateOffset, says where an element is.
VIEWED(0, state, vec4, 2 * particles * kFields, the particle state)
// Rows: for every particle, the others within reach and skin, ascending. Links: for every particle, the contacts that
// it takes part in, ordered as other particles by ascending index, surfaces, bodies. A link is slot << 1, plus 1 for
// the contact's second body.
VIEWED(1, rows, uint, canisters*(rowEntries + linkEntries), the neighbour rows)
ROW(rows, rowIndex, 0, canisters* rowEntries)
ROW(rows, linkIndex, canisters* rowEntries, canisters* linkEntries)
// Of each particle: row (first, count), links (first, count). Then: own pair slots (first, count), own surface slots
// (first, count). Then, if there are bodies: own body slots (first, count).
VIEWED(2, ranges, uvec4, (2 + bodied) * particles, the ranges of rows)
ROW(ranges, rowRangeIndex, 0, particles)
ROW(ranges, slotRangeIndex, particles, particles)
ROW(ranges, bodyRangeIndex, 2 * particles, bodied* particles)
// Of each pair or surface slot: the two vectors of History (law/contact.glsl), zero while the two bodies do not touch.
// With the energy book, then the vectors of Exerted (law/energy.glsl), each for all slots. Then of each body slot, for
// each of its places: History, the direction from the body to the particle in the frame of the body with the place's
// number (from 1; 0: not touched), and with the energy book Exerted.
VIEWED(3, history, vec4, historyParts* springSlots + bodyHistory * bodySlots, the contact history)
ROWS(history, springIndex, 0, springSlots, 2)
ROWS(history, exertedIndex, 2 * springSlots, historyParts - 2, springSlots)
ROWS(history, bodyHistoryIndex, historyParts* springSlots, bodySlots, bodyHistory)
PARAMETERS(4, members, Member, canisters, the parameters)
HEADED(5, controls, Control, canisters, the control blocks, Dispatches, dispatches)
// Of each canister's cells: the first particle, or kEmpty. Then of each particle: the next in its cell.
TABLE(6, cells, uint, canisters* cellHeads + particles, the cell table)
ROWS(cells, headIndex, 0, canisters, cellHeads)
ROW(cells, nextIndex, canisters* cellHeads, particles)
// Of each particle: high part of the position when the rows were built. Then: when the contacts were listed; w: slack.
// Then: low parts of its velocity [m/s] and of its spin [rad/s]. Their high parts are in the state.
VIEWED(7, anchors, vec4, 4 * particles, the anchors)
ROW(anchors, rowAnchorIndex, 0, particles)
ROW(anchors, listAnchorIndex, particles, particles)
ROWS(anchors, speedLowIndex, 2 * particles, particles, 2)
// [canisters][workgroups over a canister's particles].
TABLE(8, records, GroupRecord, canisters* groups, the records of the sensors)
// Of each slot: the particle; then the other particle, or the surface with the number of its works in the bits above it
// (kSurfaceBits), or the body. Coming: the entries that a refresh prepares.
VIEWED(9, entries, uvec2, 2 * slots, the contact lists)
ROW(entries, entryIndex, 0, slots)
ROW(entries, comingEntryIndex, slots, slots)
// Fields of each particle; then of each slot: layout.h, kBookNormal. Empty without an energy book.
TABLE(10, books, vec4, energyBook* kBookFields*(particles + slots), the energy book)
ROWS(books, bookIndex, 0, energyBook* kBookFields, particles)
ROWS(books, slotBookIndex, kBookFields* particles, energyBook* kBookFields, slots)
// Of each particle, sums over the steps since the last sensing of what it does to each body: kBodyLoads numbers. Behind
// those of the bodies the same of each surface, if a member asks for it.
TABLE(11, bodyLoads, float, kBodyLoads* loaded* particles, the loads on bodies and walls)
ROWS(bodyLoads, bodyLoadIndex, 0, kBodyLoads* loaded, particles)
// Of each slot: force on the first body [N]; w: overlap over the smaller radius. Then of each body slot and place: the
// force there; w: overlap [m]. Then, if a user's law gives particles properties, of each slot what flows to the first
// body, and of each particle its properties and their low parts (not in the anchors, which the passes of bodies lack).
VIEWED(12, forces, vec4, (1 + propertied) * slots + kMaxBodyTouches * bodySlots + 2 * propertied * particles,
       the contact forces)
ROW(forces, forceIndex, 0, slots)
ROWS(forces, bodyForceIndex, slots, bodySlots, kMaxBodyTouches)
ROW(forces, flowIndex, slots + kMaxBodyTouches * bodySlots, propertied* slots)
ROWS(forces, propertyIndex, (1 + propertied) * slots + kMaxBodyTouches * bodySlots, propertied* particles, 2)
// Of each slot: torque on the first body [N m]; w: of a body slot with the energy book the work of the body in the step
// [J]. Torque on the second body.
VIEWED(13, torques, vec4, 2 * slots, the contact torques)
ROWS(torques, torqueIndex, 0, slots, 2)
// As the history, of the slots that a refresh prepares.
TABLE(14, carried, vec4, historyParts* springSlots + bodyHistory * bodySlots, the carried history)

#undef TABLE
#undef VIEWED
#undef PARAMETERS
#undef HEADED
#undef ROW
#undef ROWS
