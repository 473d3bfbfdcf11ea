cmake_minimum_required(VERSION 3.25)

# Fails unless the headers <cardan/<component>.hpp> in the folder `made` include every public header once and none of those in
# detail/ and registers/.
set(included "")
separate_arguments(components)
foreach(component IN LISTS components)
    file(STRINGS ${made}/${component}.hpp lines REGEX "^#include ")
    foreach(line IN LISTS lines)
        string(REGEX REPLACE "^#include \"(.*)\"$" "\\1" header ${line})
        list(APPEND included ${header})
    endforeach()
endforeach()
list(REMOVE_ITEM included mbs/base/version.hpp) # made as well

set(public "")
foreach(folder IN ITEMS mbs elements solvers turbines)
    file(GLOB_RECURSE headers RELATIVE ${source_dir} ${source_dir}/${folder}/*.hpp)
    list(FILTER headers EXCLUDE REGEX "/(detail|registers)/")
    list(APPEND public ${headers})
endforeach()

list(SORT included)
list(SORT public)
if(NOT included STREQUAL public)
    set(missing ${public})
    list(REMOVE_ITEM missing ${included} none)
    message(FATAL_ERROR "not each once; missing: ${missing}; included: ${included}")
endif()
list(LENGTH public count)
message("${count} public headers")
