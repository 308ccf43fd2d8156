# Writes OUTPUT from TEMPLATE, where @version@ becomes a hash of SOURCES (names in FOLDER, separated by
# commas) and of EXTRA.
string(REPLACE "," ";" sources "${SOURCES}")
set(all "${EXTRA}")
foreach(source IN LISTS sources)
  file(SHA256 "${FOLDER}/${source}" hash)
  string(APPEND all " ${hash}")
endforeach()
string(SHA256 version "${all}")
configure_file("${TEMPLATE}" "${OUTPUT}" @ONLY)
