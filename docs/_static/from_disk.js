// Opened from a disk, a page may not read other pages: the search then shows titles without the lines around a hit.
if (location.protocol === "file:") DOCUMENTATION_OPTIONS.SHOW_SEARCH_SUMMARY = false;
