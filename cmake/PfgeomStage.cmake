# pfgeom_stage(NAME [STAGE...]): the static library pfgeom_NAME of native/pfgeom/NAME/*.cpp, which may use the named
# stages. A stage of headers alone has no library. All libraries together are pfgeom::core.

add_library(pfgeom_core INTERFACE)
add_library(pfgeom::core ALIAS pfgeom_core)
target_link_libraries(pfgeom_core INTERFACE pfgeom_options)
set(PFGEOM_STAGES)     # in pipeline order
set(PFGEOM_LIBRARIES)  # those with a library, likewise

macro(pfgeom_stage name)
    list(APPEND PFGEOM_STAGES ${name})
    file(GLOB _sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/native/pfgeom/${name}/*.cpp)
    if(_sources)
        add_library(pfgeom_${name} STATIC ${_sources})
        target_link_libraries(pfgeom_${name} PUBLIC pfgeom_options PRIVATE $<BUILD_INTERFACE:pfgeom_warnings>)
        foreach(_stage ${ARGN})
            if(TARGET pfgeom_${_stage})
                target_link_libraries(pfgeom_${name} PUBLIC pfgeom_${_stage})
            endif()
        endforeach()
        set_target_properties(pfgeom_${name} PROPERTIES EXPORT_NAME ${name})
        target_link_libraries(pfgeom_core INTERFACE pfgeom_${name})
        list(APPEND PFGEOM_LIBRARIES pfgeom_${name})
    endif()
endmacro()

# Eigen is headers alone, so an installed stage does not need it any more. Its vectorised paths differ between machines.
function(pfgeom_uses_eigen)
    foreach(_stage ${ARGN})
        if(TARGET pfgeom_${_stage})
            target_link_libraries(pfgeom_${_stage} PRIVATE $<BUILD_INTERFACE:Eigen3::Eigen>)
            target_compile_definitions(pfgeom_${_stage} PRIVATE EIGEN_DONT_VECTORIZE EIGEN_MPL2_ONLY)
        endif()
    endforeach()
endfunction()
