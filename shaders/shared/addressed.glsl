// The tables as passes reach them where one is longer than the device binds: by addresses, which the host writes into
// the head of the control blocks. Parameters and control blocks are short and stay bound.
#ifndef VKDOSE_SHARED_ADDRESSED_GLSL
#define VKDOSE_SHARED_ADDRESSED_GLSL

#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require

#define TABLE(number, name, element, count, title) \
    const uint name##Binding = number;             \
    layout(buffer_reference, std430, buffer_reference_align = 16) buffer name##Elements { element at[]; };
#define PARAMETERS(number, name, element, count, title) BOUND(number, name, element, readonly)
#define HEADED(number, name, element, count, title, head, headName) BOUND_HEADED(number, name, element, head, headName)
#include "shared/tables.h"

#define TABLE(number, name, element, count, title) \
    name##Elements name##Table = name##Elements(dispatches.tables[number].xy);
#define PARAMETERS(number, name, element, count, title)
#define HEADED(number, name, element, count, title, head, headName)
#include "shared/tables.h"

// With these, a pass writes state[at] whichever way it reaches the table. So nothing else may have a table's name.
#define state stateTable.at
#define rows rowsTable.at
#define ranges rangesTable.at
#define history historyTable.at
#define cells cellsTable.at
#define anchors anchorsTable.at
#define records recordsTable.at
#define entries entriesTable.at
#define books booksTable.at
#define bodyLoads bodyLoadsTable.at
#define forces forcesTable.at
#define torques torquesTable.at
#define carried carriedTable.at

#endif
