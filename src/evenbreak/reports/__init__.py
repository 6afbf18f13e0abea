"""From files to results and from results to files: tables in, frames, sheets and figures out.

Only this room and `evenbreak.cli` touch files, plots and the terminal.
"""

from evenbreak._lazy import attach

__getattr__, __dir__, __all__ = attach(
    __name__,
    {
        "break_plots": ["breaks_figure"],
        "draw": ["draw", "image_bytes"],
        "frames": ["ratings_frame", "summary_frame"],
        "html_sheet": ["sheet_html"],
        "matchups": ["RaceLimits", "find_players", "matchups_frame", "most_active"],
        "moves_frame": ["moves_frame", "moves_of_files"],
        "paper": ["pdf_bytes"],
        "problems": ["Problems"],
        "published": [
            "Erratum",
            "PublishedNumber",
            "errata",
            "further_numbers",
            "p5_6_tables",
            "physics_errata",
            "physics_numbers",
            "published_numbers",
        ],
        "read_aliases": ["AliasesFile", "read_aliases"],
        "read_arcs": ["ArcsFile", "read_arcs"],
        "read_chart": ["chart_frame", "find_chart", "read_chart"],
        "read_drill_log": ["DrillLogFile", "read_drill_log"],
        "read_league": ["LeagueFile", "read_league"],
        "read_results": ["ResultsFile", "read_results"],
        "read_roster": ["RosterFile", "read_roster"],
        "read_schedule": ["ScheduleFile", "read_schedule"],
        "read_table": ["Table", "read_table"],
        "reproduce": ["reproduction"],
        "sheet": ["sheet_text"],
        "sheet_pages": ["sheet_pages"],
        "shot_on_table": ["shot_on_table"],
        "shot_plots": ["shots_figure"],
        "to_csv": ["to_csv"],
        "workbook": ["report_tables", "workbook_bytes"],
        "write_files": ["write_files"],
    },
)
