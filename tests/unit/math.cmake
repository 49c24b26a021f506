# The shared shader math, compiled as C++, against closed forms, quadrature and enumeration.
foreach(TEST random warp brdf brdf_furnace layer_albedo light_math environment_math reservoir mis path_sample
             spherical_triangle texture_filter denoise_math)
  tarn_test(${TEST} LABEL unit LIBRARIES tarn_shared tarn_core)
endforeach()
foreach(TEST alias_table packing ray_offset)
  tarn_test(${TEST} LABEL unit LIBRARIES tarn_world)
endforeach()
