# SPDX-License-Identifier: BSD-3-Clause
# Packages inside this source tree; catkin does not search for packages below a package.xml.
#
#   add_own_packages(RESULT package... [YIELDING package...])
#
# Adds the packages from subfolders with their names. A package of the same name in the workspace takes precedence; an
# installed one takes precedence over YIELDING packages. RESULT: the folders of the added packages.
set(OWN_PACKAGES_FINDER ${CMAKE_CURRENT_LIST_DIR}/find_workspace_package.py)

function(add_own_packages result)
  cmake_parse_arguments(PARSE_ARGV 1 own "" "" YIELDING)
  set(ours ${own_UNPARSED_ARGUMENTS} ${own_YIELDING})
  execute_process(
    COMMAND ${PYTHON_EXECUTABLE} ${OWN_PACKAGES_FINDER} ${CMAKE_BINARY_DIR} ${ours}
    OUTPUT_VARIABLE found
    COMMAND_ERROR_IS_FATAL ANY
  )
  list(POP_FRONT found sources)
  if(sources)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${sources})  # a package was added or removed
  endif()

  # Only installed packages have a package.xml in share/: packages built earlier in a devel space are not found.
  set(prefixes ${CMAKE_PREFIX_PATH} /usr)
  list(REMOVE_ITEM prefixes "${CMAKE_INSTALL_PREFIX}")
  set(used "")
  foreach(package users IN ZIP_LISTS ours found)
    set(installed "")
    if(package IN_LIST own_YIELDING)
      foreach(prefix IN LISTS prefixes)
        if(EXISTS ${prefix}/share/${package}/package.xml)
          set(installed ${prefix}/share/${package})
          break()
        endif()
      endforeach()
    endif()
    if(users)
      message(STATUS "${package}: using the workspace's package in ${users} (if bubblesim was built before it was added, "
                     "run catkin clean once)")
    elseif(installed)
      message(STATUS "${package}: using the installed ${installed}")
    else()
      add_subdirectory(${package})
      list(APPEND used ${CMAKE_CURRENT_SOURCE_DIR}/${package})
    endif()
  endforeach()
  set(${result} "${used}" PARENT_SCOPE)
endfunction()
