# Finds OpenImageIO with its own CMake package, and works around a flaw in Ubuntu's. There the imported target lists
# OpenCV's include directory, which libopenimageio-dev does not install, and CMake rejects targets with missing include
# directories. (Only OpenImageIO's imagebufalgo_opencv.h needs it, which is not included here.)
find_package(OpenImageIO ${OpenImageIO_FIND_VERSION} CONFIG QUIET)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenImageIO CONFIG_MODE)

if(OpenImageIO_FOUND)
    get_target_property(directories OpenImageIO::OpenImageIO INTERFACE_INCLUDE_DIRECTORIES)
    set(present "")
    foreach(directory IN LISTS directories)
        if(EXISTS "${directory}")
            list(APPEND present "${directory}")
        endif()
    endforeach()
    set_target_properties(OpenImageIO::OpenImageIO PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${present}")
endif()
