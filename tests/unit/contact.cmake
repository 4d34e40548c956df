strut_test(test_contact_laws SOURCES test_contact_laws.cpp SEES contact RANKS 1)
