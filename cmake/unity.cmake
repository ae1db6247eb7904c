# Unity builds compile common headers and templates once for several source files. Names in unnamed namespaces must
# therefore be unique within a target. CALLIGRAPHY_UNITY=OFF compiles each file on its own, which detects missing
# includes (scripts/full/each_file.sh).
option(CALLIGRAPHY_UNITY "Unity build: compile several source files as one, in a third of the time" ON)

# calligraphy_unity(target files): compiles up to `files` source files of the target per unit.
function(calligraphy_unity target files)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${CALLIGRAPHY_UNITY} UNITY_BUILD_BATCH_SIZE ${files})
endfunction()
