# cmake -DBUILD=… -DEXAMPLE=… -DWORK=… -DCOMPILER=… -DVERSION=… -P installed_example.cmake
cmake_minimum_required(VERSION 3.25)

function(run)
    execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE ${WORK}/prefix ${WORK}/example)
run(${CMAKE_COMMAND} --install ${BUILD} --component development --prefix ${WORK}/prefix)
run(${CMAKE_COMMAND} -S ${EXAMPLE} -B ${WORK}/example -G Ninja -DCMAKE_BUILD_TYPE=Release
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_PREFIX_PATH=${WORK}/prefix -DPFGEOM_VERSION=${VERSION})
run(${CMAKE_COMMAND} --build ${WORK}/example)

run(${WORK}/example/sphere ${WORK}/example/sphere.pfg ${WORK}/example/sphere.ply)
foreach(result sphere.pfg sphere.ply)
    if(NOT EXISTS ${WORK}/example/${result})
        message(FATAL_ERROR "the example did not write ${result}")
    endif()
endforeach()
