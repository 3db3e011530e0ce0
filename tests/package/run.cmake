# Installs ribvault to a folder of its own, then configures, builds and runs a project that knows nothing but that folder.
# Wants BUILD, SCRATCH, CONSUMER, MODEL, GENERATOR, COMPILER, FLAGS, TYPE.
cmake_policy(VERSION 3.25)
function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE ${SCRATCH})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${SCRATCH}/installed --config ${TYPE})
run(${CMAKE_COMMAND} -S ${CONSUMER} -B ${SCRATCH}/build -G ${GENERATOR} -DCMAKE_PREFIX_PATH=${SCRATCH}/installed
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_FLAGS=${FLAGS} -DCMAKE_BUILD_TYPE=${TYPE})
run(${CMAKE_COMMAND} --build ${SCRATCH}/build --config ${TYPE})
run(${SCRATCH}/build/consumer ${MODEL})
file(REMOVE_RECURSE ${SCRATCH})
