# The executor of device/ needs the headers of OpenCL, and nothing else: it loads the system's loader
# of drivers when a device is asked for. Without the headers, device/no_opencl.cpp replaces it. What
# prints programs needs no headers.

find_path(OPENCL_INCLUDE_FOLDER CL/cl.h)
if(OPENCL_INCLUDE_FOLDER)
  list(APPEND CASCADE_WITHOUT device/no_opencl)
  cascade_room(device ${CMAKE_DL_LIBS})
  target_include_directories(cascade_device SYSTEM PUBLIC ${OPENCL_INCLUDE_FOLDER})
else()
  list(APPEND CASCADE_WITHOUT "device/((device|opencl).*|probe)")
  cascade_room(device)
endif()
