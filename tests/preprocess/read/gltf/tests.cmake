# The encoders of what a glTF file may be compressed by.
find_package(meshoptimizer REQUIRED)
farcell_tests(preprocess/read/gltf DEPS farcell_preprocess_read farcell_tests_support meshoptimizer::meshoptimizer
              APART gltf_look_test.cpp gltf_scene_test.cpp)
if(TARGET farcell_draco)
  target_link_libraries(preprocess_read_gltf_test PRIVATE farcell_draco)
endif()
