# OpenImageIO by its own CMake package, minus a flaw of Ubuntu's: there the imported target names OpenCV's include
# directory, which libopenimageio-dev does not bring along, and CMake refuses a target whose include directory is missing.
# (Only OpenImageIO's imagebufalgo_opencv.h needs it; we do not include that.)
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
