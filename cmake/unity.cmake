# Several source files compiled as one: what they include, and the templates that they use, is compiled once for all of
# them. Names in unnamed namespaces are therefore unique within a target; CALLIGRAPHY_UNITY=OFF compiles each file on its
# own, which finds an #include that is missing (scripts/full/each_file.sh).
option(CALLIGRAPHY_UNITY "Compile several source files as one: a third of the time" ON)

# calligraphy_unity(target files): so many files of the target to a unit.
function(calligraphy_unity target files)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${CALLIGRAPHY_UNITY} UNITY_BUILD_BATCH_SIZE ${files})
endfunction()
