from .answer_page import answer_page as answer_page
from .pdf_page import pdf_bytes as pdf_bytes
from .round_page import round_page as round_page
from .sheet_page import sheet_page as sheet_page
from .sheet_pdf import sheet_pages as sheet_pages
from .sheet_pdf import sheet_pdf as sheet_pdf
from .workbook import report_tables as report_tables
from .workbook import workbook_bytes as workbook_bytes
