# Writes version.cpp anew if the checkout in SOURCE has changed: cmake -DSOURCE=… -DKCS_VERSION=… -DKCS_BUILD=… -DOUTPUT=… -P
if(NOT KCS_BUILD)
  execute_process(COMMAND git describe --always --dirty --abbrev=12 --exclude=* WORKING_DIRECTORY ${SOURCE}
                  OUTPUT_VARIABLE KCS_BUILD OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
if(NOT KCS_BUILD)
  set(KCS_BUILD unknown)
endif()
configure_file(${CMAKE_CURRENT_LIST_DIR}/version.cpp.in ${OUTPUT} @ONLY)
