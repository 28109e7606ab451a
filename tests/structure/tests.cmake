add_test(NAME Structure.LayersDependenciesAndSizesAreAsAgreed
         COMMAND bash ${CMAKE_CURRENT_SOURCE_DIR}/structure/check.sh ${CMAKE_SOURCE_DIR})
add_test(NAME Structure.TheCheckFindsEachViolation COMMAND bash ${CMAKE_CURRENT_SOURCE_DIR}/structure/check_test.sh)
set_tests_properties(Structure.LayersDependenciesAndSizesAreAsAgreed Structure.TheCheckFindsEachViolation
                     PROPERTIES LABELS structure)
