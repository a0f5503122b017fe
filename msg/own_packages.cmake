# SPDX-License-Identifier: BSD-3-Clause
# Packages that lie in this tree, because catkin does not look for packages below a package.xml.
#
#   add_own_packages(RESULT package... [YIELDING package...])
#
# Adds those in folders of their names below the current one. A package that the workspace has of its own wins over ours,
# and so does an installed one over those that yield. RESULT: the folders of ours that are used.
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

  # Only installed packages have their package.xml in share/, so what we built in a devel space before is not found.
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
      message(STATUS "${package}: using the workspace's own in ${users} (if bubblesim was built before it was there, clean "
                     "the workspace once: catkin clean)")
    elseif(installed)
      message(STATUS "${package}: using the installed ${installed}")
    else()
      add_subdirectory(${package})
      list(APPEND used ${CMAKE_CURRENT_SOURCE_DIR}/${package})
    endif()
  endforeach()
  set(${result} "${used}" PARENT_SCOPE)
endfunction()
