# Compiler settings that every target shares. Where another project builds Tarn, its own settings stand.
if(PROJECT_IS_TOP_LEVEL)
  find_program(CCACHE ccache)
  if(CCACHE)
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
    set(CMAKE_C_COMPILER_LAUNCHER ${CCACHE})
  endif()

  # -O3 for the tracer. NDEBUG is for libraries' own assertions; ours follow TARN_ASSERTIONS.
  set(CMAKE_CXX_FLAGS_RELWITHDEBINFO "-O3 -g1 -DNDEBUG")
  set(CMAKE_C_FLAGS_RELWITHDEBINFO "-O2 -g1 -DNDEBUG")
elseif(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  message(WARNING "CMAKE_BUILD_TYPE is empty: Tarn is built without optimization and renders many times slower")
endif()

# Up to eight sources of a library or program are compiled as one: most of the time goes into what they include. So names in
# the anonymous namespaces of a folder must differ. -DCMAKE_UNITY_BUILD=OFF compiles each alone, as the preset debug does.
if(PROJECT_IS_TOP_LEVEL AND NOT DEFINED CMAKE_UNITY_BUILD)
  set(CMAKE_UNITY_BUILD ON)
endif()

# No fused multiply-add: the shared shader math must round the same way on every machine.
add_compile_options(-Wall -Wextra -ffp-contract=off)

if(TARN_ASSERTIONS)
  add_compile_definitions(TARN_ASSERTIONS)
endif()

if(TARN_SANITIZE)
  add_compile_options(-fsanitize=address,undefined -fno-omit-frame-pointer -fno-sanitize-recover=undefined)
  add_link_options(-fsanitize=address,undefined)
endif()
