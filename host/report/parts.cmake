# The parts of a report's page as C++ strings, report/parts.h in the build folder. D3, three.js and their licences are
# Debian's.
find_file(D3_SCRIPT d3.min.js PATHS /usr/share/javascript/d3 REQUIRED)
find_file(D3_LICENCE copyright PATHS /usr/share/doc/libjs-d3 NO_DEFAULT_PATH REQUIRED)
find_file(THREE_SCRIPT three.min.js PATHS /usr/share/javascript/three/build REQUIRED)
find_file(THREE_LICENCE copyright PATHS /usr/share/doc/libjs-three NO_DEFAULT_PATH REQUIRED)

set(parts "")
foreach(part Page:page.html Style:page.css Charts:charts.js Ramp:ramp.js Controls:controls.js Stream:stream.js
        Fields:fields.js Run:run.js Runs:runs.js Study:study.js Validation:validation.js Main:main.js
        Player:player.js PlayerFrames:player_frames.js PlayerColours:player_colours.js PlayerBodies:player_bodies.js
        PlayerScene:player_scene.js
        D3:${D3_SCRIPT} Licence:${D3_LICENCE} Three:${THREE_SCRIPT} ThreeLicence:${THREE_LICENCE})
  string(REGEX MATCH "^([^:]*):(.*)$" unused ${part})
  set(name ${CMAKE_MATCH_1})
  get_filename_component(file ${CMAKE_MATCH_2} ABSOLUTE BASE_DIR ${CMAKE_CURRENT_LIST_DIR})
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  file(READ ${file} text)
  string(APPEND parts "inline constexpr char k${name}[] = R\"_part_(${text})_part_\";\n")
endforeach()
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/report/parts.h CONTENT
"#pragma once\n\nnamespace vkdose::report::parts {\n\n\${parts}\n}\n")
