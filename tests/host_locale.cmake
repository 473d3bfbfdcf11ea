cmake_minimum_required(VERSION 3.25)

# Fails when a source of the library reads or writes numbers, or asks what a letter is, in a way that depends on the
# locale of the host program. mbs/base/text.hpp has it all, always as in the C locale.
set(streams
    "std::(o|i)?stringstream( [a-z_]+)?[;({]" # text_stream(), text_reader()
    "std::o?fstream" # write_file()
    "std::(cout|cerr|locale|use_facet|put_time|put_money|get_time|regex)"
    "<c?locale>")
set(functions
    "sto(i|l|ul|ll|ull|f|d|ld)|strto[a-z]+|ato(i|l|ll|f)|[a-z]?scanf|from_chars" # read_number()
    "v?f?s?n?printf|to_string|to_chars" # text(), digits()
    "is(alnum|alpha|blank|cntrl|digit|graph|lower|print|punct|space|upper|xdigit)" # is_digit(), is_letter()
    "to(lower|upper)" # lower_case(), upper_case()
    "strftime|strcoll")
list(JOIN streams "|" streams)
list(JOIN functions "|" functions)

file(GLOB_RECURSE files RELATIVE ${source_dir} ${source_dir}/mbs/*.[ch]pp ${source_dir}/elements/*.[ch]pp
     ${source_dir}/solvers/*.[ch]pp ${source_dir}/turbines/*.[ch]pp)
# Where it is done; the bytes of files, and a line of the system.
list(REMOVE_ITEM files mbs/base/text.hpp mbs/base/text.cpp mbs/base/text_file.cpp mbs/base/pending_file.cpp)
set(violations "")
foreach(file IN LISTS files)
    file(STRINGS ${source_dir}/${file} written REGEX "${streams}")
    file(STRINGS ${source_dir}/${file} called REGEX "(^|[^a-z_])(${functions}) ?\\(")
    foreach(line IN LISTS written called)
        string(STRIP "${line}" line)
        if(NOT line MATCHES "^//")
            string(APPEND violations "\n  ${file}: ${line}")
        endif()
    endforeach()
endforeach()

if(violations)
    message(FATAL_ERROR "depends on the locale of the host program; mbs/base/text.hpp does not:${violations}")
endif()
list(LENGTH files count)
if(count LESS 100)
    message(FATAL_ERROR "only ${count} sources below ${source_dir}")
endif()
message(STATUS "host locale: ${count} sources read and write by mbs/base")
