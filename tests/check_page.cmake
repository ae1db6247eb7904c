# cmake -DPAGE=page -DFILE=file -P check_page.cmake: fails unless the page shows the whole file as a block of C++.
file(READ ${PAGE} page)
file(READ ${FILE} code)
string(FIND "${page}" "```cpp\n${code}```" place)
if(place EQUAL -1)
  message(FATAL_ERROR "${PAGE} does not show ${FILE} as it is: copy the file into the page's block of C++")
endif()
