# SPDX-License-Identifier: BSD-3-Clause
# generate_package_messages([DEPENDENCIES package...])
#
# Like generate_messages() of genmsg, with the same files, targets and installed files, for C++ and Python: one process
# generates all code of a package. genmsg starts two for each message, and a third in every build that looks for changed
# dependencies: together a tenth of a first build. test_msgs, which users copy into their workspaces, has genmsg's.
set(PACKAGE_MESSAGES_GENERATOR ${CMAKE_CURRENT_LIST_DIR}/generate_code.py)

macro(generate_package_messages)
  set(CATKIN_MESSAGE_GENERATORS "")  # none of genmsg's own: it writes what other packages need to find the messages
  generate_messages(${ARGN})
  _add_package_messages(${ARGN})
  include_directories(BEFORE ${CATKIN_DEVEL_PREFIX}/include)
  list(APPEND ${PROJECT_NAME}_INCLUDE_DIRS ${CATKIN_DEVEL_PREFIX}/include)
  list(APPEND ${PROJECT_NAME}_EXPORTED_TARGETS ${PROJECT_NAME}_generate_messages_cpp ${PROJECT_NAME}_generate_messages_py)
endmacro()

function(_add_package_messages)
  cmake_parse_arguments(PARSE_ARGV 0 own "" "" DEPENDENCIES)
  find_package(gencpp REQUIRED)
  set(headers ${CATKIN_DEVEL_PREFIX}/include/${PROJECT_NAME})
  set(modules ${CATKIN_DEVEL_PREFIX}/${PYTHON_INSTALL_DIR}/${PROJECT_NAME})
  file(MAKE_DIRECTORY ${headers} ${modules})  # catkin_package() wants them before they are filled
  set(definitions ${${PROJECT_NAME}_MESSAGE_FILES} ${${PROJECT_NAME}_SERVICE_FILES})
  set(generated "")
  foreach(definition IN LISTS definitions)
    cmake_path(GET definition STEM name)
    cmake_path(GET definition EXTENSION kind)
    string(REPLACE "." "" kind ${kind})
    list(APPEND generated ${headers}/${name}.h ${modules}/${kind}/_${name}.py ${modules}/${kind}/__init__.py)
  endforeach()
  list(REMOVE_DUPLICATES generated)
  set(folders "")  # where the types of each package are
  set(used ${definitions})
  while(MSG_INCLUDE_DIRS)
    list(POP_FRONT MSG_INCLUDE_DIRS package folder)
    list(APPEND folders --folder ${package} ${folder})
    file(GLOB found ${folder}/*.msg)
    list(APPEND used ${found})
  endwhile()
  list(REMOVE_DUPLICATES used)

  add_custom_command(
    OUTPUT ${generated}
    COMMAND ${CATKIN_ENV} ${PYTHON_EXECUTABLE} ${PACKAGE_MESSAGES_GENERATOR} ${PROJECT_NAME} ${definitions} ${folders}
            --templates ${GENCPP_TEMPLATE_DIR} --headers ${headers} --modules ${modules}
    DEPENDS ${PACKAGE_MESSAGES_GENERATOR} ${used}
    COMMENT "Generating C++ and Python code of ${PROJECT_NAME}"
    VERBATIM
  )
  add_custom_target(${PROJECT_NAME}_generated_code DEPENDS ${generated})
  foreach(language cpp py)
    add_custom_target(${PROJECT_NAME}_generate_messages_${language})
    add_custom_target(${PROJECT_NAME}_gen${language})
    add_dependencies(${PROJECT_NAME}_generate_messages_${language} ${PROJECT_NAME}_generated_code)
    add_dependencies(${PROJECT_NAME}_gen${language} ${PROJECT_NAME}_generate_messages_${language})
    add_dependencies(${PROJECT_NAME}_generate_messages ${PROJECT_NAME}_generate_messages_${language})
    foreach(package IN LISTS own_DEPENDENCIES)
      if(TARGET ${package}_generate_messages_${language})
        add_dependencies(${PROJECT_NAME}_generate_messages_${language} ${package}_generate_messages_${language})
      endif()
    endforeach()
  endforeach()

  install(CODE "execute_process(COMMAND \"${PYTHON_EXECUTABLE}\" -m compileall -q \"${modules}\")")
  install(DIRECTORY ${headers} DESTINATION include)
  install(DIRECTORY ${modules} DESTINATION ${PYTHON_INSTALL_DIR})
endfunction()
