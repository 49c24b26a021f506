# Compiler settings that every target shares.
find_program(CCACHE ccache)
if(CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
  set(CMAKE_C_COMPILER_LAUNCHER ${CCACHE})
endif()

# -O3 for the tracer. NDEBUG is for libraries' own assertions; ours follow TARN_ASSERTIONS.
set(CMAKE_CXX_FLAGS_RELWITHDEBINFO "-O3 -g1 -DNDEBUG")
set(CMAKE_C_FLAGS_RELWITHDEBINFO "-O2 -g1 -DNDEBUG")

# No fused multiply-add: the shared shader math must round the same way on every machine.
add_compile_options(-Wall -Wextra -ffp-contract=off)

if(TARN_ASSERTIONS)
  add_compile_definitions(TARN_ASSERTIONS)
endif()

if(TARN_SANITIZE)
  add_compile_options(-fsanitize=address,undefined -fno-omit-frame-pointer -fno-sanitize-recover=undefined)
  add_link_options(-fsanitize=address,undefined)
endif()
