# Installs the build and looks at what is there.
file(REMOVE_RECURSE ${PREFIX})
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${PREFIX} --config ${TYPE}
                COMMAND_ERROR_IS_FATAL ANY)
if(PHANTOM AND NOT EXISTS ${PREFIX}/lib/udev/rules.d/60-calligraphy.rules)
  message(FATAL_ERROR "no udev rules were installed")
endif()
if(TOOLS)
  execute_process(COMMAND ${PREFIX}/bin/calligraphy --version COMMAND_ERROR_IS_FATAL ANY)
endif()
