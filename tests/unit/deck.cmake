strut_test(test_deck SOURCES test_deck.cpp test_deck_errors.cpp test_deck_peridigm.cpp test_deck_sections.cpp
           SEES deck RANKS 1 2)
strut_test(deck_reference SOURCES test_deck_reference.cpp SEES deck RANKS 1)
