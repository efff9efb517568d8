# swept_link_folder(FOLDER LINK): the folder is seen through the link, too. Windows asks for a privilege to make symbolic links,
# and for none to make junctions, which do for folders. Included by the top-level list file only.
function(swept_link_folder folder link)
    if(NOT CMAKE_HOST_WIN32)
        file(CREATE_LINK ${folder} ${link} SYMBOLIC)
        return()
    endif()
    if(IS_DIRECTORY ${link})
        return()
    endif()
    cmake_path(NATIVE_PATH folder native_folder)
    cmake_path(NATIVE_PATH link native_link)
    execute_process(COMMAND cmd /c mklink /J ${native_link} ${native_folder}
                    RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
    if(NOT result EQUAL 0 OR NOT IS_DIRECTORY ${link})
        message(FATAL_ERROR "Swept2D: ${link} could not be made a junction to ${folder} (mklink /J: ${output}). The build folder has "
                            "to lie on a disk of this machine, formatted as NTFS or ReFS.")
    endif()
endfunction()
