# Toolchain: this machine, taken for another one, of whose compiler nothing is used that not every compiler has.
set(CMAKE_SYSTEM_NAME ${CMAKE_HOST_SYSTEM_NAME})
set(CMAKE_SYSTEM_PROCESSOR ${CMAKE_HOST_SYSTEM_PROCESSOR})
set(CMAKE_CXX_FLAGS_INIT -pedantic-errors)
